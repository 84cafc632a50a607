"""How sure a result is: laws' and parameters' confidence, prediction bands, residuals."""
