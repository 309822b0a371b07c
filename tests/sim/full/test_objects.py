"""The objects of the set: how many, of which families, and which are held out."""

from collections import defaultdict

from cltp.data.contact import Split
from cltp.tactile.states import Shape
from sim.full.objects import DRAWN, HELD_OUT, Origin, all_objects, is_held_out, object_of
from sim.full.requests import SENSORS, PressKind, full_request


def test_there_are_more_objects_than_the_issue_asks_for_each_with_its_own_name():
    objects = all_objects()
    assert len(objects) >= 150
    assert len({choice.name for choice in objects}) == len(objects)
    assert {choice.origin for choice in objects} == set(Origin) - {Origin.NOTHING}


def test_every_shape_has_at_least_seven_drawn_objects_of_two_families():
    drawn = defaultdict(list)
    for choice in all_objects():
        for shape, group in DRAWN.items():
            if choice.kind in group:
                drawn[shape].append(choice)
    assert set(drawn) == set(Shape)
    for shape, choices in drawn.items():
        assert len(choices) >= 7, shape  # and more of the catalogue, by their pose
        assert {choice.origin for choice in choices} == {Origin.PARAMETRIC, Origin.SCANNED}


def test_one_drawn_object_of_each_shape_is_held_out():
    assert [len(HELD_OUT & set(group)) for group in DRAWN.values()] == [1] * len(Shape)


def test_a_series_is_always_the_same_and_held_out_objects_are_for_tests():
    requests = [full_request(3, number) for number in range(1500)]
    assert requests[7] == full_request(3, 7)
    assert requests[7] != full_request(4, 7)
    for request in requests:
        assert (request.split is Split.OBJECT) == is_held_out(request.choice)
        assert all(a < b for a, b in zip(request.depths_mm, request.depths_mm[1:], strict=False))
    assert {request.sensor.name for request in requests} == set(SENSORS)
    shallow = [request for request in requests if request.kind is PressKind.SHALLOW]
    assert all(request.depths_mm[-1] < 0.15 for request in shallow)
    assert 0.12 < len(shallow) / len(requests) < 0.20


def test_within_a_few_cycles_every_object_is_pressed():
    pressed = {object_of(number).name for number in range(8 * 700)}
    assert pressed == {choice.name for choice in all_objects()} | {"nothing"}
