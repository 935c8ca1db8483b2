"""The campaign of extremes: scenes written for it, their solutions, rows and report."""
