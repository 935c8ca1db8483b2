"""From the scenes of midplane to checked results, pictures and tables: one module a command, `python -m midplane_pipeline.draw --help`.

results     what the others need of a scene and its results, beside the reader of the package midplane
check       results are whole, balanced, and as known
draw        pictures of results, meshes, paths and studies
exact       closed forms that pictures and checks compare with
scenes      scenes that programs write: walls of bricks, concrete at the meso scale
extremes    every row of docs/EXTREMES.md
trade       speed against accuracy, docs/TRADE.md
bench       times of whole runs, beside other programs
robust      damaged and random inputs, kills, mutants, shards, two builds compared
house       advisories, licences and hashes of what is used
"""
