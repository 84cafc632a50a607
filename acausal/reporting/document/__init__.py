"""The page of a model: a frozen record of all that it tells, and the HTML file that shows it."""
