"""Speed, measured beside other software on the same cases."""
