SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 1, 1};
Physical Volume("soil") = {1};
Physical Surface("base") = {5};
