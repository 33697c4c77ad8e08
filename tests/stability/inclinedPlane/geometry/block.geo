// A flat block on the plane y = 0.
SetFactory("OpenCASCADE");
Rectangle(1) = {1, 0, 0, 2, 0.5};
Physical Surface("soil") = {1};
