"""The application: command line, run configuration, the loop, drivers, episodes, training.

No other package imports it. Importing it loads neither torch nor open3d nor a device's SDK.
"""

__version__ = "0.1.0"
