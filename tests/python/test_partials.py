"""L and its partials, as users get them."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import central_differences, random_state
from scenes import chain, cradle

import saltus


def test_partials_have_their_numeric_twins():
    model = chain(4)
    q, v = random_state(model)
    L = model.lagrangian(q, v)
    close = {"rtol": 1e-6, "atol": 1e-8}
    np.testing.assert_allclose(
        L.L_q, central_differences(lambda x: model.lagrangian(x, v).value, q), **close
    )
    np.testing.assert_allclose(
        L.L_v, central_differences(lambda x: model.lagrangian(q, x).value, v), **close
    )
    np.testing.assert_allclose(
        L.L_qq, central_differences(lambda x: model.lagrangian(x, v).L_q, q), **close
    )
    np.testing.assert_allclose(
        L.L_vq, central_differences(lambda x: model.lagrangian(x, v).L_v, q), **close
    )
    np.testing.assert_allclose(L.L_vv, model.mass_matrix(q), rtol=1e-13, atol=1e-16)


def test_partials_are_views_that_cannot_be_written():
    L = cradle().lagrangian(*random_state(cradle()))
    assert L.L_qq is not L.L_qq
    assert np.shares_memory(L.L_qq, L.L_qq)
    assert np.shares_memory(L.L_v, L.L_v)
    with pytest.raises(ValueError, match="read-only"):
        L.L_q[0] = 1
    view = L.L_vv
    expected = view.copy()
    del L
    np.testing.assert_array_equal(view, expected)  # the view keeps its owner alive


def test_partials_are_written_into_those_of_an_earlier_call():
    model = chain(4)
    out = model.lagrangian(*random_state(model))
    L_qq, before = out.L_qq, out.L_qq.copy()
    q, v = np.full(model.n_q, 0.3), np.full(model.n_v, -0.7)
    assert model.lagrangian(q, v, out=out) is out
    fresh = model.lagrangian(q, v)
    assert out.value == fresh.value
    for name in ("L_q", "L_v", "L_qq", "L_vq", "L_vv"):
        np.testing.assert_array_equal(getattr(out, name), getattr(fresh, name))
    np.testing.assert_array_equal(L_qq, fresh.L_qq)  # a view of the same array
    assert not np.array_equal(L_qq, before)
    for wrong in ({"q": np.full(model.n_q, np.nan), "v": v}, {"q": q, "v": v[1:]}):
        with pytest.raises(saltus.ModelError):
            model.lagrangian(**wrong, out=out)
        np.testing.assert_array_equal(out.L_qq, fresh.L_qq)
    with pytest.raises(saltus.ModelError, match="out has partials of n = 4; this model"):
        cradle().lagrangian(np.zeros(6), np.zeros(6), out=out)
    with pytest.raises(TypeError, match="out is <class 'float'>; it is LagrangianPartials"):
        model.lagrangian(q, v, out=1.0)
