// A long layer: its middle knows nothing of its ends.
SetFactory("OpenCASCADE");
Rectangle(1) = {-20, 0, 0, 120, 8};
Physical Surface("soil") = {1};
