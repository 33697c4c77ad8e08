SetFactory("OpenCASCADE");
Rectangle(1) = {2, 2, 0, 10, 10};
Physical Surface("soil") = {1};
