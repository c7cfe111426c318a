"""Who may use the service: keys, scopes, rates, headers."""
