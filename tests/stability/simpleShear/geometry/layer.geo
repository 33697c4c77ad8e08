// A long layer: its middle, y = 4, knows nothing of its ends.
half = 4;
SetFactory("OpenCASCADE");
Rectangle(1) = {-20, 4 - half, 0, 120, 2 * half};
Physical Surface("soil") = {1};
