SetFactory("OpenCASCADE");
Rectangle(1) = {2, 0, 0, 2, 10};
Physical Surface("soil") = {1};
