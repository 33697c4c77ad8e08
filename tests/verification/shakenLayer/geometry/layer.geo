// A column of a layer 10 m thick, two cells wide; periodic along x.
cell = 0.25;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2*cell, 10};
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
