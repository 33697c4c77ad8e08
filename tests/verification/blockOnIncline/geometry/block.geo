// A flat block on the plane y = 0.
SetFactory("OpenCASCADE");
Rectangle(1) = {0.5, 0, 0, 2, 0.25};
Physical Surface("block") = {1};
