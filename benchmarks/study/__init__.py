"""The paper's study, made again: its tables and figures, planned and judged by Tandem."""
