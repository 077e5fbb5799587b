"""Where the robot is: pose filter."""
