"""The pictures of docs/figures, one function each; scripts/figures calls them all."""
