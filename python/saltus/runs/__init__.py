"""Running models, and what a run gives back."""
