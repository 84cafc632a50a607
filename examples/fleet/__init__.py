"""A fleet: vehicles with a mass each and one law of the resistance that they share."""
