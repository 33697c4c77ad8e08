SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 4, 4, 2};
Physical Volume("soil") = {1};
