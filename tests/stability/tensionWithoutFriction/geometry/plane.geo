SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 4, 4};
Physical Surface("soil") = {1};
