// A layer of dense sand, 1 m thick, under a heavy slab.
SetFactory("OpenCASCADE");
Rectangle(1) = {3, 0, 0, 30, 1};
Rectangle(2) = {3, 1, 0, 30, 0.5};
Physical Surface("soil") = {1};
Physical Surface("slab") = {2};
