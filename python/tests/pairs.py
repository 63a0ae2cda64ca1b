"""Three pairs of rotated boxes that overlap."""

import numpy as np

A = np.array([[0.0, 0.0, 2.0, 1.0, 0.3], [1.0, 0.5, 1.0, 3.0, -0.4], [0.2, 0.1, 1.5, 1.5, 1.0]])
B = np.array([[0.4, 0.2, 1.0, 2.0, 0.9], [1.1, 0.0, 2.0, 1.0, 0.2], [0.5, -0.3, 1.0, 1.2, 2.0]])
