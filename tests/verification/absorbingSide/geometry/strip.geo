// A strip 10 m long, two cells high; periodic along y.
cell = 0.1;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 10, 2*cell};
Physical Surface("soil") = {1};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
