# SSIM by scikit-image, of pictures displayed as engine/metrics/displayed.h says. For tests alone.
#
# Reads lines "WIDTH HEIGHT PICTURE REFERENCE" from standard input; pictures are files of 32-bit floats, RGB in linear
# light, row by row. Prints the mean SSIM of each pair. Exit code 77 says that numpy or scikit-image is absent.
import sys

try:
    import numpy as np
    from skimage.metrics import structural_similarity
except ImportError:
    sys.exit(77)


def displayed_luma(file, shape):
    light = np.clip(np.fromfile(file, np.float32).astype(np.float64).reshape(shape), 0, 1)
    encoded = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light**(1 / 2.4) - 0.055)
    return encoded @ np.array([0.2126, 0.7152, 0.0722])


for line in sys.stdin:
    width, height, picture, reference = line.split()
    shape = (int(height), int(width), 3)
    print(repr(float(structural_similarity(
        displayed_luma(picture, shape), displayed_luma(reference, shape), data_range=1, gaussian_weights=True,
        sigma=1.5, use_sample_covariance=False))))
