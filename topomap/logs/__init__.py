"""Logs of robots, as MCAP files and ROS 2 bags: to write, to read, to map by."""
