"""Small parts for every folder of this package: errors, settings, YAML, torch device, HTML pages.

Not here: anything that knows a device, an episode or a policy.

May import: cltp.
"""
