"""Logs of robots as MCAP files and ROS 2 bags: writing, reading, making maps of them."""
