"""Streets, water and green of an OpenStreetMap extract, as the console draws them under a plan."""
