"""What translational and rotational mechanics share: the flanges of both, and the elements that join them."""
