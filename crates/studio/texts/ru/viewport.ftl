# viewport
