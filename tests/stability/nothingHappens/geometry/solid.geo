SetFactory("OpenCASCADE");
Box(1) = {1.1, 1, 1, 1.35, 1.2, 1.45};
Physical Volume("soil") = {1};
