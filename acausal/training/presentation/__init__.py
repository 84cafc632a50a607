"""What trainings show: pages, views in a notebook, the model card beside an exported model."""
