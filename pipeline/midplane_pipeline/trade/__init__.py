"""Speed against accuracy: the campaign, its fronts, its page and its tables."""
