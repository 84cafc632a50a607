"""EMPS: a measured positioning axis of motor, screw and carriage, with a friction that nobody knows."""
