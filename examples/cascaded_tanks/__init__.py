"""The Cascaded Tanks: a measured pump, two tanks that overflow, and a level sensor that saturates."""
