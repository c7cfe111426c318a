"""Routes as linked stops, where a turn takes as long however long they are."""
