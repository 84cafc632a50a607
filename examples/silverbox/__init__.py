"""The Silverbox: a measured circuit that behaves as a car's suspension with a progressive spring."""
