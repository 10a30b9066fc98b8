// What it says of those that see it is that which they would say of others, and so many judges hold their place.
