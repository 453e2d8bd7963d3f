"""Expected maps, maps of scans, limits."""

import copy
import pickle
from concurrent.futures import ThreadPoolExecutor

import mean_information as mi
import numpy as np
import pytest


def test_an_expected_map_is_the_mean():
    random = np.random.default_rng(11)
    particles = random.random((7, 5, 6))
    weights = random.random(7)
    expected = mi.expected_map(particles, weights)
    mean = np.average(particles, axis=0, weights=weights)
    np.testing.assert_allclose(expected.probabilities, mean, rtol=4e-16)
    assert expected.tally.cells == 30 and expected.mean_information == expected.tally.mean_information
    assert expected.mean_information == pytest.approx(mi.mean_information(mean), rel=1e-14)
    own = mi.mean_information(particles, axis=(1, 2))
    assert expected.mean_of_particles == pytest.approx(np.average(own, weights=weights), rel=1e-15)
    # Neither order nor scale of the weights changes a bit.
    again = mi.expected_map(list(particles[::-1]), weights[::-1] * 8)
    assert again.tally == expected.tally
    np.testing.assert_array_equal(again.probabilities, expected.probabilities)
    assert "EMMI" in repr(expected)


def test_masked_cells_of_particles_are_refused():
    particles = np.array([[[0.125, 0.25]], [[0.375, 0.5]]])
    masked = np.ma.masked_less(particles, 0.2)
    for given in (masked, list(masked)):
        with pytest.raises(TypeError, match="masked"):
            mi.expected_map(given)
    # A mask without masked cells hides nothing.
    assert mi.expected_map(np.ma.array(particles)).mean_information == mi.expected_map(particles).mean_information


def test_expected_maps_of_every_encoding():
    percent = np.array([[[-1, 0]], [[100, 0]]], np.int8)
    expected = mi.expected_map(percent, [6, 2], encoding="percent")
    assert expected.probabilities.tolist() == [[0.625, 0.0]]
    single = mi.expected_map(np.float32([[[0.25]], [[0.5]]]))
    assert single.probabilities.dtype == np.float32 and single.tally.dtype == np.float32
    assert mi.expected_map([[[2.0]]], encoding="log-odds").tally.information == pytest.approx(0.4729346589968384, rel=1e-15)
    assert mi.expected_map([np.array([[-32]], np.int8)], encoding="mrpt").tally.occupied == 1


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_where_leaves_cells_of_all_particles_out(dtype):
    random = np.random.default_rng(12)
    particles = random.random((4, 5, 6)).astype(dtype)
    where = random.random((5, 6)) < 0.6
    particles[:, ~where] = np.nan
    expected = mi.expected_map(particles, [1, 2, 3, 4], where=where)
    chosen = mi.expected_map([particle[where][None] for particle in particles], [1, 2, 3, 4])
    assert expected.tally == chosen.tally and expected.mean_of_particles == chosen.mean_of_particles
    assert np.isnan(expected.probabilities[~where]).all() and expected.probabilities.dtype == dtype
    np.testing.assert_array_equal(expected.probabilities[where], chosen.probabilities[0])
    column = mi.expected_map(particles[:, :, :1], where=where[:, :1])
    assert column.tally == mi.expected_map(particles[:, :, :1], where=np.asfortranarray(where)[:, :1]).tally
    # A cell that is not allowed is named by its place in its map.
    row, place = np.argwhere(where)[-1]
    particles[2, row, place] = 1.5
    with pytest.raises(ValueError, match=rf"^particles\[2\]\[{row}, {place}\] is 1.5, allowed is"):
        mi.expected_map(particles, where=where)
    with pytest.raises(ValueError, match="where has 3 dimensions, allowed are those of a map"):
        mi.expected_map(particles, where=np.ones(particles.shape, bool))
    with pytest.raises(ValueError, match="broadcast"):
        mi.expected_map(particles, where=where[1:])
    with pytest.raises(TypeError, match="where takes booleans"):
        mi.expected_map(particles, where=[1])
    assert mi.expected_map(particles, where=False).tally.cells == 0


def test_bad_particles_are_refused():
    good = np.full((2, 3, 4), 0.25)
    bad = good.copy()
    bad[1, 2, 0] = np.nan
    for particles in (bad, list(bad)):
        with pytest.raises(ValueError, match=r"^particles\[1\]\[2, 0\] is nan, allowed is a probability from 0 to 1$"):
            mi.expected_map(particles)
    with pytest.raises(ValueError, match=r"^particles\[0\]\[0, 1\] is 205, allowed is a percentage .*, or 255 for unknown$"):
        mi.expected_map(np.array([[[255, 205]]], np.uint8), encoding="percent")
    with pytest.raises(ValueError, match="encoding is 'x', allowed are"):
        mi.expected_map([], encoding="x")
    for weights, words in [
        ([1.0], "number of weights is 1, allowed is 2"),
        ([1.0, -1.0], "weight 1 is -1"),
        ([0.0, 0.0], "weight"),
        ([np.nan, 1.0], "weight 0 is NaN"),
        (np.ones((2, 1)), "weights are a list"),
    ]:
        with pytest.raises(ValueError, match=words):
            mi.expected_map(good, weights)
    with pytest.raises(ValueError, match="number of particles is 0"):
        mi.expected_map([])
    with pytest.raises(ValueError, match=r"one shape"):
        mi.expected_map([[[0.5]], [[0.5, 0.5]]])
    with pytest.raises(TypeError, match="one type"):
        mi.expected_map([np.float32([[0.5]]), np.array([[0.5]])])


def test_limits():
    limit = mi.limit(2.0, 0.2)
    assert (limit.value, limit.status, limit.evaluations) == (0.7893368880256514, "converged", 0)
    assert limit.lower < limit.value < limit.upper
    assert limit == mi.limit(2.0, 0.2) and limit != mi.limit(2.0, 0.25)
    area = mi.limit(2.0, 0.2, weight="area").value
    for method in ("adaptive", "rigorous"):
        other = mi.limit(2.0, 0.2, weight="area", method=method)
        assert other.lower <= area <= other.upper and other.evaluations > 0
    with pytest.raises(ValueError, match="sigma is 0, allowed is positive"):
        mi.limit(2.0, 0.0)
    with pytest.raises(ValueError, match="weight is 'x', allowed are"):
        mi.limit(2.0, 0.2, weight="x")
    with pytest.raises(ValueError, match="method is 'x', allowed are"):
        mi.limit(2.0, 0.2, method="x")


def drive(scans, poses, remove=False):
    bearings = np.linspace(-1.5, 1.5, 91)
    for x, y, heading in poses:
        ranges = 2.0 + 0.5 * np.sin(3 * (bearings + heading)) + 0.1 * x
        (scans.remove if remove else scans.insert)((x, y, heading), bearings, ranges, max_range=4.0)


def test_scans_are_inserted_and_removed():
    poses = [(0.1 * k, -0.05 * k, 0.2 * k) for k in range(12)]
    forwards, backwards = mi.ScanMap(0.1, agreement=True), mi.ScanMap(0.1, agreement=True)
    drive(forwards, poses)
    drive(backwards, poses[::-1])
    assert forwards.tally() == backwards.tally() and forwards.scans == 12
    probabilities = forwards.probabilities()
    np.testing.assert_array_equal(probabilities, backwards.probabilities())
    assert mi.tally(probabilities).observed == forwards.tally().observed
    x, y = forwards.origin
    assert x < 0 and y < 0 and round(x / 0.1) * 0.1 == x
    assert 0 < forwards.agreement <= 1 and mi.ScanMap(0.1).agreement is None
    drive(forwards, poses[3:], remove=True)
    few = mi.ScanMap(0.1)
    drive(few, poses[:3])
    assert forwards.tally() == few.tally()
    with pytest.raises(ValueError, match="number of times that the map holds the scan"):
        drive(forwards, poses[5:6], remove=True)
    assert forwards.tally() == few.tally()


def test_a_pose_is_any_sequence_of_three_numbers():
    expected = mi.ScanMap(0.25)
    expected.insert((1, 2.5, 0.5), [0.0], [1.0], max_range=4.0)
    for pose in ([1, 2.5, 0.5], np.array([1, 2.5, 0.5]), np.float32([1, 2.5, 0.5]), tuple(np.array([1, 2.5, 0.5]))):
        scans = mi.ScanMap(0.25)
        scans.insert(pose, [0.0], [1.0], max_range=4.0)
        assert scans.tally() == expected.tally()
        scans.remove(pose, [0.0], [1.0], max_range=4.0)
        assert scans.scans == 0
    with pytest.raises(ValueError, match="pose has 0 dimensions"):
        scans.insert(None, [0.0], [1.0], max_range=4.0)


def test_copies_of_a_map_of_scans_are_maps_of_their_own():
    scans = mi.ScanMap(0.1, agreement=True)
    drive(scans, [(0.0, 0.0, 0.0)])
    before, agreement = scans.tally(), scans.agreement
    for copied in (copy.copy(scans), copy.deepcopy(scans)):
        assert copied.tally() == before and copied.sensor == scans.sensor
        drive(copied, [(0.3, 0.1, 0.2)])
        assert copied.scans == 2 and copied.tally() != before
        drive(copied, [(0.0, 0.0, 0.0)], remove=True)
        assert copied.scans == 1
    assert scans.scans == 1 and scans.tally() == before and scans.agreement == agreement
    with pytest.raises(TypeError, match="a ScanMap is not pickled: insert its scans again"):
        pickle.dumps(scans)
    assert repr(scans) == "<ScanMap of 1 scan, cells of 0.1 m>"
    assert repr(mi.ScanMap(1.0)) == "<ScanMap of 0 scans, cells of 1.0 m>"


def test_masked_ranges_are_left_out_and_other_masks_refused():
    pose, bearings, ranges = (0.0, 0.0, 0.0), [-0.5, 0.0, 0.5], [1.0, 0.25, 2.0]
    left_out, masked = mi.ScanMap(0.1), mi.ScanMap(0.1)
    left_out.insert(pose, bearings, [1.0, np.nan, 2.0], max_range=4.0)
    for dtype in (float, np.float32, int):
        data = np.ma.array([1, 0.25, 2], mask=[False, True, False]).astype(dtype)
        masked.insert(pose, bearings, data, max_range=4.0)
        assert masked.tally() == left_out.tally() and not np.isnan(data.data.astype(float)).any()
        masked.remove(pose, bearings, data, max_range=4.0)
        assert masked.scans == 0
    hidden = np.ma.array([0.0, 0.0, 0.0], mask=[False, False, True])
    for arguments, name in [((pose, hidden, ranges), "bearings"), ((hidden, bearings, ranges), "pose")]:
        with pytest.raises(TypeError, match=f"{name} has masked numbers, which are unknown"):
            masked.insert(*arguments, max_range=4.0)
    # A mask without masked numbers hides nothing.
    masked.insert(np.ma.array(pose), np.ma.array(bearings), np.ma.array(ranges), max_range=4.0)
    unmasked = mi.ScanMap(0.1)
    unmasked.insert(pose, bearings, ranges, max_range=4.0)
    assert masked.tally() == unmasked.tally()
    complex_ = np.array([0.0, 0.0, 1j])
    for arguments, name in [
        ((pose, complex_, ranges), "bearings"),
        ((pose, bearings, complex_), "ranges"),
        ((complex_, bearings, ranges), "pose"),
    ]:
        with pytest.raises(TypeError, match=f"{name} has complex numbers, allowed are real ones"):
            masked.insert(*arguments, max_range=4.0)
    assert masked.scans == 1


def test_threads_share_a_map_of_scans():
    """None is refused, and all that was inserted is there: while one measures a large map, while one inserts."""
    scans, poses = mi.ScanMap(0.004), [(0.001 * k, 0.0, 0.0) for k in range(24)]
    drive(scans, poses[:1])
    assert scans.tally().cells > 200_000
    with ThreadPoolExecutor(4) as pool:
        inserted = [pool.submit(drive, scans, poses[k : k + 1]) for k in range(1, 24)]
        measured = [pool.submit(measure) for _ in range(12) for measure in (scans.tally, scans.probabilities, scans.__repr__)]
        for future in inserted + measured:
            future.result()
    one_by_one = mi.ScanMap(0.004)
    drive(one_by_one, poses)
    assert scans.scans == 24 and scans.tally() == one_by_one.tally()


def test_a_sensor_that_asks_for_its_map_is_refused():
    class Curious(Own):
        def reach(self, range):
            return scans.scans + range

    scans = mi.ScanMap(0.25, sensor=Curious())
    for _ in range(2):
        with pytest.raises(RuntimeError, match="asked for while a scan is inserted or removed, by its sensor"):
            drive(scans, [(0.0, 0.0, 0.0)])
    assert scans.scans == 0


def test_results_travel():
    expected = mi.expected_map(np.array([[[0.125, 0.5]], [[0.75, 0.5]]]), [6, 2])
    limit = mi.limit(2.0, 0.2)
    for travel in (lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy, copy.copy):
        assert travel(limit) == limit
        arrived = travel(expected)
        assert arrived.tally == expected.tally and arrived.mean_of_particles == expected.mean_of_particles
        np.testing.assert_array_equal(arrived.probabilities, expected.probabilities)
        assert repr(arrived) == repr(expected)


class Own:
    """Steps, in Python."""

    def occupancy(self, distance, range):
        return 0.5 if distance > self.reach(range) else 0.875 if distance >= range - 0.125 else 0.25

    def reach(self, range):
        return range + 0.125


def test_sensors():
    own, named = mi.ScanMap(0.25, sensor=Own()), mi.ScanMap(0.25, sensor=mi.SteppedSensor(0.25, 0.25, 0.875))
    drive(own, [(0.13, 0.12, 0.5)])
    drive(named, [(0.13, 0.12, 0.5)])
    assert own.tally() == named.tally()

    class Broken(Own):
        def occupancy(self, distance, range):
            raise LookupError("no such place")

    broken = mi.ScanMap(0.25, sensor=Broken())
    with pytest.raises(LookupError, match="no such place"):
        drive(broken, [(0.0, 0.0, 0.0)])
    assert broken.scans == 0 and broken.tally().cells == 0

    class Nonsense(Own):
        def occupancy(self, distance, range):
            return 2.0

    with pytest.raises(ValueError, match="beam 0"):
        drive(mi.ScanMap(0.25, sensor=Nonsense()), [(0.0, 0.0, 0.0)])
    with pytest.raises(TypeError, match="sensor is int, allowed are GaussianSensor"):
        mi.ScanMap(0.25, sensor=7)
    for sensor in (mi.GaussianSensor(0.1), mi.SteppedSensor(0.2, free=0.3, occupied=0.8)):
        assert pickle.loads(pickle.dumps(sensor)) == sensor
        assert eval(repr(sensor), vars(mi)) == sensor
    assert mi.ScanMap(0.25).sensor == mi.SteppedSensor(0.25, 0.4, 0.7)
    with pytest.raises(ValueError, match="sigma is -1"):
        mi.GaussianSensor(-1.0)


def test_bad_scans_are_refused():
    scans = mi.ScanMap(0.25)
    for arguments, words in [
        (((0.0, 0.0, np.nan), [0.0], [1.0]), "theta of the pose is NaN"),
        (((0.0, 0.0, 0.0), [np.inf], [1.0]), "bearing of beam 0 is inf"),
        (((0.0, 0.0, 0.0), [0.0], [-1.0]), "range of beam 0 is -1"),
        (((0.0, 0.0, 0.0), [0.0, 1.0], [1.0]), "2 bearings were given for 1 ranges"),
        (((0.0, 0.0, 0.0), [[0.0]], [[1.0]]), "bearings has 2 dimensions, allowed is one dimension"),
        (((0.0, 0.0, 0.0), [0.0], 1.0), "ranges has 0 dimensions, allowed is one dimension"),
        (((0.0, 0.0), [0.0], [1.0]), "pose is of 2 numbers, allowed are 3: x, y, heading"),
        (([0.0], [0.0], [1.0]), "pose is of 1 number, allowed are 3"),
        ((np.zeros((1, 3)), [0.0], [1.0]), "pose has 2 dimensions"),
        ((["a", 0, 0], [0.0], [1.0]), "pose: could not convert"),
        (((0.0, 0.0, 0.0), ["b"], [1.0]), "bearings: could not convert"),
    ]:
        with pytest.raises(ValueError, match=words):
            scans.insert(*arguments, max_range=4.0)
    with pytest.raises(MemoryError, match="allowed are 67108864"):
        scans.insert((0.0, 0.0, 0.0), [0.0, 1.5, 3.0, -1.5], [1e5] * 4, max_range=2e5)
    scans.insert((0.0, 0.0, 0.0), [0.0], [np.nan], max_range=4.0)  # says nothing
    assert scans.scans == 0
    with pytest.raises(ValueError, match="resolution is 0"):
        mi.ScanMap(0.0)
