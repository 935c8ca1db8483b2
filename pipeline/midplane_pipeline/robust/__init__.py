"""The program under damage, random inputs, kills and mutation; studies in shards; two builds bit by bit."""
