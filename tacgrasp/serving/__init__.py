"""A policy asked over the network: openpi's protocol, on a server of ours and as a policy of a run.

Websocket, msgpack with arrays in it, no pickle. Needs the extra ``serve`` (websockets, msgpack).
Not here: the policies themselves, which the caller makes.

May import: cltp, cltp.tactile, policies, policies.extraction, primitives, tacgrasp.base,
tacgrasp.config, tacgrasp.episodes, tacgrasp.runtime.
"""
