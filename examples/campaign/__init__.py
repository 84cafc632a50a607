"""A test campaign: five runs of a drive train, as they are measured, train one model."""
