SetFactory("OpenCASCADE");
Disk(1) = {5, 5, 0, 1};
Physical Surface("soil") = {1};
