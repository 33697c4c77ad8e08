// Two discs of radius 0.2 m on the diagonal of the unit square.
SetFactory("OpenCASCADE");
Disk(1) = {0.2, 0.2, 0, 0.2};
Disk(2) = {0.8, 0.8, 0, 0.2};
Physical Surface("discs") = {1, 2};
