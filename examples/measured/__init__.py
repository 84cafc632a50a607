"""What the examples on published measurements share: their data, initial states, errors, tables and pages."""
