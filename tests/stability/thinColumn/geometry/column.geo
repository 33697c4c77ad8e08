// A column 1000 cells high and one cell wide.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 0.25, 250};
Physical Surface("soil") = {1};
