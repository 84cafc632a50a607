"""A battery cell: five measured records train connected components, whose laws keep what physics knows."""
