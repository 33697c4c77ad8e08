SetFactory("OpenCASCADE");
Rectangle(1) = {-4, -1, 0, 8, 2};
Physical Surface("soil") = {1};
