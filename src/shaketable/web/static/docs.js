// The interface as OpenAPI describes it; nothing is asked of any other host.
SwaggerUIBundle({ url: "openapi.json", dom_id: "#interface", validatorUrl: null, deepLinking: true });
