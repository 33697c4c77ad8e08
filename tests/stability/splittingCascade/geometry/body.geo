// A block that is pulled apart while it turns.
SetFactory("OpenCASCADE");
Rectangle(1) = {-1, -1, 0, 2, 2};
Physical Surface("soil") = {1};
