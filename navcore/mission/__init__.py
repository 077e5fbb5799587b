"""Events and their effects, the state machine, the mode selector."""
