SetFactory("OpenCASCADE");
Rectangle(1) = {2, 1, 0, 8, 1};
Physical Surface("soil") = {1};
