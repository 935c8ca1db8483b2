"""Text from scenes, studies and programs, made fit for a page."""

import html
import unicodedata
from typing import Any


def page_text(value: object) -> str:
    """The text without characters that no page may show or that turn the direction of writing, and nothing read as markup."""

    def bad(c: Any) -> Any:
        return unicodedata.category(c) in ("Cc", "Cf", "Cs", "Zl", "Zp") and c not in "\n\t"

    return html.escape("".join("\ufffd" if bad(c) else c for c in str(value)))
