# LDR-FLIP and HDR-FLIP a second time, written from the papers (Andersson et al. 2020 and 2021) with whole two-dimensional
# filters and doubles, and sharing nothing with the program. For tests alone.
#
# Reads lines "KIND PIXELS_PER_DEGREE WIDTH HEIGHT PICTURE REFERENCE MAP" from standard input. KIND is "ldr" or "hdr";
# pictures are files of 32-bit floats, RGB in linear light, row by row. Writes MAP, one float a pixel; for "hdr" prints the
# first exposure, the last one and how many there are. Exit code 77 says that numpy is absent.
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(77)


def xyz_of(rgb):
    matrix = np.array([[10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
                       [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
                       [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382]])
    return np.einsum("ij,yxj->yxi", matrix, rgb), matrix


def ycxcz_of(rgb):
    xyz, matrix = xyz_of(rgb)
    white = matrix @ np.ones(3)
    x, y, z = (xyz[..., i] / white[i] for i in range(3))
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def rgb_of_ycxcz(color):
    _, matrix = xyz_of(np.zeros((1, 1, 3)))
    white = matrix @ np.ones(3)
    y = (color[..., 0] + 16) / 116
    xyz = np.stack([y + color[..., 1] / 500, y, y - color[..., 2] / 200], axis=-1) * white
    return np.einsum("ij,yxj->yxi", np.linalg.inv(matrix), xyz)


def hunt_lab_of(rgb):
    xyz, matrix = xyz_of(rgb)
    t = xyz / (matrix @ np.ones(3))
    delta = 6 / 29
    f = np.where(t > delta**3, np.cbrt(t), t / (3 * delta**2) + 4 / 29)
    lightness = 116 * f[..., 1] - 16
    a = 500 * (f[..., 0] - f[..., 1])
    b = 200 * (f[..., 1] - f[..., 2])
    return np.stack([lightness, 0.01 * lightness * a, 0.01 * lightness * b], axis=-1)


def hyab(p, q):
    d = p - q
    return np.abs(d[..., 0]) + np.hypot(d[..., 1], d[..., 2])


def correlate(plane, kernel):
    """The filter at every pixel; beyond the border the outermost pixels are repeated."""
    radius = kernel.shape[0] // 2
    padded = np.pad(plane, radius, mode="edge")
    result = np.zeros_like(plane)
    for j in range(kernel.shape[0]):
        for i in range(kernel.shape[1]):
            result += kernel[j, i] * padded[j:j + plane.shape[0], i:i + plane.shape[1]]
    return result


def sensitivity_filter(gaussians, ppd):
    radius = int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi**2)) * ppd))
    y, x = np.mgrid[-radius:radius + 1, -radius:radius + 1] / ppd
    kernel = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * (x * x + y * y) / b) for a, b in gaussians)
    return kernel / kernel.sum()


def feature_filter(order, ppd):
    sigma = 0.5 * 0.082 * ppd
    radius = int(np.ceil(3 * sigma))
    y, x = np.mgrid[-radius:radius + 1, -radius:radius + 1]
    gauss = np.exp(-(x * x + y * y) / (2 * sigma * sigma))
    kernel = -x * gauss if order == 1 else (x * x / sigma**2 - 1) * gauss
    return np.where(kernel > 0, kernel / kernel[kernel > 0].sum(), kernel / -kernel[kernel < 0].sum())


def preprocessed(light, ppd):
    """The perceived colour, and the strength of edges and of points."""
    opponent = ycxcz_of(light)
    filters = [[(1, 0.0047)], [(1, 0.0053)], [(34.1, 0.04), (13.5, 0.025)]]
    seen = np.stack([correlate(opponent[..., i], sensitivity_filter(filters[i], ppd)) for i in range(3)], axis=-1)
    color = hunt_lab_of(np.clip(rgb_of_ycxcz(seen), 0, 1))
    grey = (opponent[..., 0] + 16) / 116
    features = []
    for order in (1, 2):
        kernel = feature_filter(order, ppd)
        features.append(np.hypot(correlate(grey, kernel), correlate(grey, kernel.T)))
    return color, features[0], features[1]


def ldr_flip(picture, reference, ppd):
    """Of linear light in [0, 1]."""
    color_a, edge_a, point_a = preprocessed(picture, ppd)
    color_b, edge_b, point_b = preprocessed(reference, ppd)
    primaries = hunt_lab_of(np.array([[[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]]))
    largest = hyab(primaries[0, 0], primaries[0, 1])**0.7
    difference = hyab(color_a, color_b)**0.7
    at_break = 0.4 * largest
    color = np.where(difference < at_break, 0.95 / at_break * difference,
                     0.95 + (difference - at_break) / (largest - at_break) * 0.05)
    feature = np.sqrt(np.maximum(np.abs(edge_a - edge_b), np.abs(point_a - point_b)) / np.sqrt(2))
    return color**(1 - feature)


def aces(light):
    x = 0.6 * np.maximum(light, 0)
    return np.clip(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0, 1)


def hdr_flip(picture, reference, ppd):
    luminance = np.maximum(reference, 0) @ np.array([0.2126, 0.7152, 0.0722])
    # The light that the tone mapper brings to 0.85, found by halving intervals.
    low, high = 0.0, 100.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if aces(np.float64(middle)) < 0.85 else (low, middle)
    first, last = np.log2(low / luminance.max()), np.log2(low / np.median(luminance))
    count = max(2, int(np.ceil(last - first)))
    maps = [ldr_flip(aces(picture * 2**ev), aces(reference * 2**ev), ppd) for ev in np.linspace(first, last, count)]
    print(first, last, count)
    return np.max(maps, axis=0)


for line in sys.stdin:
    kind, ppd, width, height, picture_file, reference_file, map_file = line.split()
    shape = (int(height), int(width), 3)
    picture, reference = (np.fromfile(f, np.float32).astype(np.float64).reshape(shape)
                          for f in (picture_file, reference_file))
    if kind == "hdr":
        result = hdr_flip(picture, reference, float(ppd))
    else:
        result = ldr_flip(np.clip(picture, 0, 1), np.clip(reference, 0, 1), float(ppd))
    result.astype(np.float32).tofile(map_file)
