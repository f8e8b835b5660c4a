"""How much a visitor may ask for."""

from __future__ import annotations

MOST_BYTES = 20_000_000  # of an uploaded record
MOST_LIST = 2_500_000  # bytes of a list that is assessed
MOST_SHAKING = 1_500_000  # bytes of a question with a motion of the visitor's own
MOST_ROOM = 60_000  # letters of a room
MOST_ROOM_BYTES = 150_000  # of a question about a room: JSON writes some letters with several
MOST_ASKED = 20_000  # bytes of any other request
MOST_HELD = 200_000_000  # bytes of requests that are in memory, of all visitors
MOST_HELD_ADDRESS = 45_000_000  # of one address
HEADER_SECONDS = 10.0  # until the header of a request has come
BODY_SECONDS = 20.0  # until the rest has
READ_SECONDS = 60.0  # for which somebody may leave an answer unread
MOST_SAMPLES = 60_000  # of an uploaded motion
MOST_SECONDS = 600.0  # of an uploaded motion
MOST_STEPS = 1_000_000  # of a simulation in a plane, while the ground moves
LOUDEST_BESIDE = 5.0  # g, beside a wall or in a strap, where a thing bangs at each swing
LEAST_FRICTION = 0.02  # ice; with less, what slides is simulated for minutes
LEAST_SIZE = 0.005  # m
MOST_SLENDER = 200.0  # height over a width, and a width over the height
MOST_NAME = 120  # characters
MOST_WAITING = 400  # questions that wait for a worker, of all visitors
MOST_CONNECTED = 1000  # connections
MOST_ADDRESS = 40  # of one address
MOST_EACH = 8  # of one visitor
UPLOAD_SECONDS = 60.0  # until a file has come
# Seconds of a processor that a question may cost.
SHAKE_SECONDS = 10.0  # one shaking, one record
MANY_SECONDS = 40.0  # a hundred shakings, at ten strengths; a box in a strap takes 9
LIST_SECONDS = 10.0  # to read a list
ASSESS_SECONDS = 600.0  # to assess it
MOST_ROWS = 2000  # of a list
MOST_THINGS = 40  # of a room; so many places, doors and corners, too
MOST_ROOM_SIDE = 40.0  # m
ROOM_CORES = 2  # for a room that is assessed: somebody waits for its map
MOST_LISTS = 100  # whose results are kept, the latest
MOST_LISTS_ADDRESS = 30  # of one address
MOST_LISTS_EACH = 10  # of one visitor
MOST_LISTS_AT_WORK = 4  # of one address, that wait or are assessed
UNWATCHED = 120.0  # s after which a list that nobody asks for is not assessed any more
LOOKED_AT = 900.0  # s for which the result of a list stays, once somebody has looked at it
MOST_FAULTS = 20  # of a question that are told
WORKER_MEMORY = 2 << 30  # bytes beside what a worker has mapped when it starts
