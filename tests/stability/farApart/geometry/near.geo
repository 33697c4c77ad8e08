// The first alone.
SetFactory("OpenCASCADE");
Rectangle(1) = {2, 0.5, 0, 1, 1};
Physical Surface("near") = {1};
