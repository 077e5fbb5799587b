"""Every published figure from one command, beside the paper's and the baseline's."""
