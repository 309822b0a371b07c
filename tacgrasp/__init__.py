"""The application: command line, run configuration, the loop, drivers, episodes, training.

Importing it loads neither torch nor open3d nor a device's SDK. Not here: anything that another
package needs, since none may import this one.

May import: cltp, policies, primitives, sim.grasp, tacgrasp.base, tacgrasp.config,
tacgrasp.episodes, tacgrasp.rig, tacgrasp.runtime, tacgrasp.serving.
"""

__version__ = "0.1.0"
