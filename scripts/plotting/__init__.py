"""The pictures of a report, one module per picture. They read the report and nothing else."""
