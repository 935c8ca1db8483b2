"""What is wrong with results, gathered."""


class Faults(list):
    """The faults found so far; every check adds to it and goes on."""

    def expect(self, good, text):
        if not good:
            self.append(text)
        return good
