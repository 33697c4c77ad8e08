// A bar of 5 mm that flies against the wall x = 0.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 0.005, 5e-05};
Physical Surface("steel") = {1};
