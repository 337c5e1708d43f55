"""The structural similarity in reports, and what scikit-image finds of the same images."""

from __future__ import annotations

import numpy as np
import pytest
from skimage import metrics

import unripple as ur


def test_the_report_has_the_similarity_that_scikit_image_finds(field: ur.Field) -> None:
    assert field.grid is not None
    columns, rows, _, _ = field.grid
    report = field.report
    targets = np.array([target.at_m for target in report.targets])
    nearest = np.linalg.norm(field.points_m[:, None, :] - targets[None, :, :], axis=2).min(axis=1)
    wanted = np.exp(-0.5 * (nearest / report.ssim.target_gaussian_m) ** 2)
    images = [
        (values / values.max()).reshape(rows, columns)
        for values in (field.peak_velocity.astype(float), wanted)
    ]
    expected = metrics.structural_similarity(images[0], images[1], data_range=1.0)
    assert report.ssim.peak_velocity == pytest.approx(expected, abs=1e-6)
    assert report.ssim.target_gaussian_m == pytest.approx(report.focal_radius_m / 3)
