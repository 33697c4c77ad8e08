SetFactory("OpenCASCADE");
Rectangle(1) = {1.1, 1, 0, 2.35, 2.2};
Physical Surface("soil") = {1};
