"""The bar of tqdm: a widget in a notebook that has ipywidgets, text elsewhere."""

import warnings

from tqdm import TqdmWarning

with warnings.catch_warnings():
    # says that there are no widgets; a bar of text is as good
    warnings.simplefilter("ignore", TqdmWarning)
    from tqdm.auto import tqdm

__all__ = ["tqdm"]
