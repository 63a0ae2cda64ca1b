"""Functions, paths, verbs and losses in other processes: pickled, copied, sent by cloudpickle."""

import copy
import multiprocessing
import pickle
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import geograd

POINT, CAR = np.array([[5.0, 0.2], [9.0, 0.0]]), np.array([0.0, 0.0, 4.0, 2.0, 0.0])


@geograd.function
def clear(point: geograd.Vec2, car: geograd.Obb2):
    return geograd.distance(point, car)


def plain(x: float):
    return x * x


squared = geograd.function(plain)


class Robot:
    def __init__(self, length):
        self.length = length

    @geograd.function
    def reach(self, angle: float):
        return self.length * np.cos(angle)


def test_a_function_is_pickled_by_name():
    assert pickle.loads(pickle.dumps(clear)) is clear
    again = pickle.loads(pickle.dumps(squared))
    assert again is not squared and again(3.0) == 9.0
    with pytest.raises((pickle.PicklingError, AttributeError)):
        pickle.dumps(geograd.function(lambda x: x))


def test_a_copy_of_a_function_is_the_function():
    own = geograd.function(lambda x: x + 1.0)
    for one in (clear, squared, own):
        assert copy.copy(one) is one and copy.deepcopy(one) is one
        assert copy.deepcopy({"key": [one]})["key"][0] is one


def test_a_method_is_pickled_with_its_object():
    robot = Robot(2.0)
    reach = pickle.loads(pickle.dumps(robot.reach))
    assert reach(0.0) == 2.0 and reach.__self__ is not robot
    other = copy.deepcopy(robot)
    other.length = 3.0
    assert other.reach(0.0) == 3.0 and robot.reach(0.0) == 2.0
    assert pickle.loads(pickle.dumps(robot)).reach(0.0) == 2.0


def work(function, *arguments):
    return function(*arguments)


def test_spawned_workers_take_functions():
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        np.testing.assert_array_equal(pool.apply(work, (clear, POINT, CAR)), clear(POINT, CAR))
        assert pool.apply(work, (squared, 3.0)) == 9.0
        np.testing.assert_array_equal(pool.apply(clear.value_grad, (POINT, CAR))[0], clear(POINT, CAR))


SCRIPT = """
    import multiprocessing, sys
    import numpy as np
    import geograd

    factor = 3.0

    @geograd.function
    def scaled(x: float):
        return factor * x

    def work(x):
        return x(2.0)

    if __name__ == "__main__":
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            print(pool.apply(work, (scaled,)))
        if len(sys.argv) > 1:
            import cloudpickle
            print(cloudpickle.dumps(scaled).hex())
"""


def script(tmp_path, *arguments):
    path = tmp_path / "script.py"
    path.write_text(textwrap.dedent(SCRIPT))
    done = subprocess.run([sys.executable, path, *arguments], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_functions_of_a_script_reach_its_workers(tmp_path):
    assert script(tmp_path) == ["6.0"]


def test_cloudpickle_takes_functions_of_a_script_by_value(tmp_path):
    pytest.importorskip("cloudpickle")
    _, text = script(tmp_path, "cloudpickle")
    # This process has another __main__.
    assert pickle.loads(bytes.fromhex(text))(2.0) == 6.0


def test_cloudpickle_takes_what_a_function_captured():
    cloudpickle = pytest.importorskip("cloudpickle")
    weights = np.array([1.0, 2.0])

    @geograd.function
    def cost(q: 2):
        return q[0] * weights[0] + q[1] * weights[1]

    again = pickle.loads(cloudpickle.dumps(cost))
    np.testing.assert_array_equal(again.value_grad([1.0, 1.0])[1], weights)
    assert pickle.loads(cloudpickle.dumps(clear)) is clear


@pytest.mark.parametrize("of", [geograd.Rings, geograd.Polylines, geograd.Paths])
def test_paths_are_pickled(of):
    paths = of(np.arange(14.0).reshape(7, 2), [0, 3, 7])
    for again in (pickle.loads(pickle.dumps(paths)), copy.deepcopy(paths), copy.copy(paths)):
        assert type(again) is of and len(again) == 2
        np.testing.assert_array_equal(again.vertices, paths.vertices)
        np.testing.assert_array_equal(again.offsets, paths.offsets)


def test_paths_are_lists():
    vertices = np.arange(18.0).reshape(9, 2)
    paths = geograd.Rings(vertices, [0, 3, 3, 7, 9])
    np.testing.assert_array_equal(paths[2], vertices[3:7])
    np.testing.assert_array_equal(paths[-1], vertices[7:])
    assert [len(path) for path in paths] == [3, 0, 4, 2]
    for key, places in ((slice(1, 3), [1, 2]), ([3, 0, 0], [3, 0, 0]), (np.array([True, False, False, True]), [0, 3]), (slice(0, 0), [])):
        part = paths[key]
        assert type(part) is geograd.Rings and len(part) == len(places)
        for own, place in zip(part, places):
            np.testing.assert_array_equal(own, paths[place])
    with pytest.raises(IndexError, match="there are 4 paths"):
        paths[4]
    again = geograd.Rings.of(list(paths[2:]))
    np.testing.assert_array_equal(again.vertices, vertices[3:])


def test_modules_of_torch_are_copied_with_their_functions():
    torch = pytest.importorskip("torch")
    import geograd.torch

    class Head(torch.nn.Module):
        def __init__(self):
            super().__init__()
            self.own = geograd.torch.function(clear)
            self.verb, self.loss = geograd.torch.iou, geograd.torch.GWDLoss(reduction="sum")

        def forward(self, point, car):
            return self.own(point, car).sum() + self.loss(car, car)

    head = Head()
    point, car = torch.tensor(POINT), torch.tensor(CAR)
    for again in (copy.deepcopy(head), pickle.loads(pickle.dumps(head.own))):
        expected = head(point, car) if isinstance(again, Head) else head.own(point, car)
        torch.testing.assert_close(again(point, car), expected)
    cloudpickle = pytest.importorskip("cloudpickle")
    captured = geograd.torch.function(lambda x: x * 2.0)
    assert pickle.loads(cloudpickle.dumps(captured))(torch.tensor(3.0)) == 6.0


def test_functions_of_jax_are_pickled():
    pytest.importorskip("jax")
    import geograd.jax

    own = geograd.jax.function(clear)
    again = pickle.loads(pickle.dumps(own))
    np.testing.assert_array_equal(again(POINT.astype("f4"), CAR.astype("f4")), own(POINT.astype("f4"), CAR.astype("f4")))


def test_ray_takes_functions():
    ray = pytest.importorskip("ray")
    offset = 4.0

    @geograd.function
    def moved(x: float):
        return x + offset

    ray.init(num_cpus=1, include_dashboard=False, log_to_driver=False, ignore_reinit_error=True)
    task = ray.remote(lambda function: float(function(1.0)))
    assert ray.get(task.remote(moved)) == 5.0
    ray.shutdown()
