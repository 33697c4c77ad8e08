// A bar that flies against a wall.
SetFactory("OpenCASCADE");
Rectangle(1) = {1, 0, 0, 4, 1};
Physical Surface("soil") = {1};
