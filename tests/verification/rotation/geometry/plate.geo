SetFactory("OpenCASCADE");
Rectangle(1) = {-2, -2, 0, 4, 4};
Physical Surface("plate") = {1};
