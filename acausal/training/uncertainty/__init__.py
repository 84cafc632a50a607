"""The uncertainty of a result: confidence of laws and parameters, prediction bands, residuals."""
