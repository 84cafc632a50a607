"""A four-bar linkage on a motor: the friction of a worn joint, learned from the motor's torque."""
