// A column 4 m wide and 8 m high.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 4, 8};
Physical Surface("soil") = {1};
