// A plate fixed at x = 0 to what lets it slide in y; check.py makes it thinner.
bottom = 5.0;
thickness = 0.5;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, bottom, 0, 4, thickness};
Physical Surface("steel") = {1};
