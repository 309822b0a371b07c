import math

import pytest
import torch

from cltp.encoder.heads import transformed
from cltp.encoder.heads_output import HeadsOutput
from cltp.encoder.reader import most_probable_state, numbers_of, state_in_words
from cltp.encoder.readings import TAILS, readings_of
from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import CLASSES, NUMBERS, area_word, depth_word, position_word

MINI = sensor_named("gelsight_mini")
FORCE = NUMBERS.index("force_n")
READ = torch.tensor([[0.47, -3.2, 1.9, 0.123, 1.58], [0.2, 0.0, 0.0, 0.05, 0.01]])


def output(numbers: torch.Tensor, margin: float | None = 0.05) -> HeadsOutput:
    batch = len(numbers)
    return HeadsOutput(
        logits=tuple(torch.randn(batch, len(names)) for names in CLASSES.values()),
        numbers=numbers,
        touching=torch.zeros(batch),
        cut=torch.zeros(batch, 4),
        margins=None if margin is None else torch.full((batch, len(NUMBERS), 2), margin),
    )


@pytest.mark.parametrize("factor", [1.7, torch.tensor([0.6, 1.4])])
def test_the_force_alone_is_scaled_with_its_interval(factor: float | torch.Tensor) -> None:
    nominal, scaled = (readings_of(output(transformed(READ)), f) for f in (1.0, factor))
    for before, after in zip(nominal[3:], scaled[3:], strict=True):
        torch.testing.assert_close(after[:, :FORCE], before[:, :FORCE])
    torch.testing.assert_close(scaled.values[:, FORCE], READ[:, FORCE] * factor)
    torch.testing.assert_close(scaled.high[:, FORCE], nominal.high[:, FORCE] * factor)


def test_probabilities_add_up_and_ends_stand_around_their_numbers() -> None:
    read = readings_of(output(transformed(READ)))
    for chances in read.words:
        torch.testing.assert_close(chances.sum(-1), torch.ones(2))
    assert (read.low <= read.values).all() and (read.values <= read.high).all()
    assert (read.at(1).values == read.values[1:]).all() and len(read.at(1).words[0]) == 1


def test_a_spread_of_the_scale_widens_the_force_alone() -> None:
    sure, unsure = (readings_of(output(transformed(READ)), 1.0, s) for s in (0.0, 0.3))
    ratio = (unsure.high / unsure.values)[0, FORCE].log()
    own = (sure.high / sure.values)[0, FORCE].log()
    assert float(ratio) == pytest.approx(math.hypot(float(own), TAILS * 0.3), rel=1e-3)
    torch.testing.assert_close(sure.high[:, :FORCE], unsure.high[:, :FORCE])
    assert (unsure.low[:, FORCE] < sure.low[:, FORCE])[0]


def test_no_depth_is_negative_and_no_area_above_the_field() -> None:
    far = torch.tensor([[-0.2, -1.0, 0.0, 9.0, -1.0], [0.0, 0.0, 0.0, 0.0, 50.0]])
    read = readings_of(output(far, margin=0.5))
    assert read.values[0, 0] == 0 and read.low[0, 0] == 0 and read.values[0, 1] < 0
    assert read.values[0, 3] == 1 and read.high[0, 3] == 1 and read.values[0, FORCE] == 0
    assert all(torch.isfinite(each).all() for each in read[3:])


def test_heads_without_intervals_are_refused() -> None:
    with pytest.raises(TouchError, match="without intervals"):
        readings_of(output(transformed(READ), margin=None))


@pytest.mark.parametrize("seed", range(20))
def test_numbers_agree_with_the_words_that_are_said_beside_them(seed: int) -> None:
    torch.manual_seed(seed)
    numbers = torch.stack([READ[0] * torch.rand(5) * torch.tensor([2.5, 3.0, 4.0, 3.0, 1.0])])
    read = readings_of(output(transformed(numbers)))
    state = most_probable_state(read._replace(touching=torch.ones(1)), MINI)
    assert depth_word(state.depth_mm) == state.depth
    assert position_word(state.x_mm, state.y_mm, MINI) == state.position
    assert area_word(state.area_fraction) == state.area
    for name, number in numbers_of(read, state).items():
        assert number.low <= number.value == getattr(state, name) <= number.high
        if name == "force_n":  # no word says it
            assert number.value == pytest.approx(float(read.values[0, FORCE]))


def test_a_number_that_agrees_with_its_word_stays_as_it_is_read() -> None:
    read = readings_of(output(transformed(READ[:1])))
    words = {"depth": "moderate", "position": "middle-left", "area": "medium"}
    words |= {"shape": "disc", "texture": "smooth"}
    x_mm = float(read.values[0, 1])
    state = state_in_words(read, words, MINI)
    assert state.depth_mm == pytest.approx(0.47) and state.area_fraction == pytest.approx(0.123)
    assert x_mm == pytest.approx(-3.2)
    assert state.x_mm == pytest.approx(-MINI.width_mm / 6, abs=1e-5)
    assert state_in_words(read, words, None).x_mm == x_mm
