"""A battery pack of a thousand cells over an hour's drive."""
